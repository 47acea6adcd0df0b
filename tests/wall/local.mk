# Unit tests of src/wall.
check_PROGRAMS += tests/wall/test_facet_shares
tests_wall_test_facet_shares_SOURCES = tests/wall/test_facet_shares.c
tests_wall_test_facet_shares_LDADD = $(test_libs)
TESTS += tests/wall/test_facet_shares
EXTRA_DIST += tests/wall/facet_shares_2d.csv tests/wall/facet_shares_3d.csv

check_PROGRAMS += tests/wall/test_contact_sums
tests_wall_test_contact_sums_SOURCES = tests/wall/test_contact_sums.c
tests_wall_test_contact_sums_LDADD = $(test_libs)
TESTS += tests/wall/test_contact_sums

check_PROGRAMS += tests/wall/test_sliding_corners
tests_wall_test_sliding_corners_SOURCES = tests/wall/test_sliding_corners.c tests/wall/wall_scene.h
tests_wall_test_sliding_corners_LDADD = $(test_libs)
TESTS += tests/wall/test_sliding_corners

check_PROGRAMS += tests/wall/test_sliding_particles
tests_wall_test_sliding_particles_SOURCES = tests/wall/test_sliding_particles.c tests/wall/wall_scene.h
tests_wall_test_sliding_particles_LDADD = $(test_libs)
TESTS += tests/wall/test_sliding_particles

check_PROGRAMS += tests/wall/test_rest
tests_wall_test_rest_SOURCES = tests/wall/test_rest.c $(test_assembly)
tests_wall_test_rest_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_wall_test_rest_LDADD = $(test_libs)
TESTS += tests/wall/test_rest

check_PROGRAMS += tests/wall/test_rest_3d
tests_wall_test_rest_3d_SOURCES = tests/wall/test_rest_3d.c $(test_assembly)
tests_wall_test_rest_3d_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_wall_test_rest_3d_LDADD = $(test_libs)
TESTS += tests/wall/test_rest_3d

check_PROGRAMS += tests/wall/test_fixed_particles
tests_wall_test_fixed_particles_SOURCES = tests/wall/test_fixed_particles.c tests/wall/wall_scene.h
tests_wall_test_fixed_particles_LDADD = $(test_libs)
TESTS += tests/wall/test_fixed_particles
