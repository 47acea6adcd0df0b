# Unit tests of src/coupling.
