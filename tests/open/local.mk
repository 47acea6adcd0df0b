# Unit tests of src/open.
