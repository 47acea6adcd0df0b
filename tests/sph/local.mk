# Unit tests of src/sph.
