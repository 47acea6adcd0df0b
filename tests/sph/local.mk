# Unit tests of src/sph.
check_PROGRAMS += tests/sph/test_cell_grid
tests_sph_test_cell_grid_SOURCES = tests/sph/test_cell_grid.c tests/sph/points.h
tests_sph_test_cell_grid_LDADD = $(test_libs)
TESTS += tests/sph/test_cell_grid

check_PROGRAMS += tests/sph/test_neighbour_list
tests_sph_test_neighbour_list_SOURCES = tests/sph/test_neighbour_list.c tests/sph/points.h
tests_sph_test_neighbour_list_LDADD = $(test_libs)
TESTS += tests/sph/test_neighbour_list

check_PROGRAMS += tests/sph/test_shepard
tests_sph_test_shepard_SOURCES = tests/sph/test_shepard.c tests/sph/points.h
tests_sph_test_shepard_LDADD = $(test_libs)
TESTS += tests/sph/test_shepard

check_PROGRAMS += tests/sph/test_turning_load
tests_sph_test_turning_load_SOURCES = tests/sph/test_turning_load.c
tests_sph_test_turning_load_LDADD = $(test_libs)
TESTS += tests/sph/test_turning_load
