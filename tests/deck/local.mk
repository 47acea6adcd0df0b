# Unit tests of src/deck.
