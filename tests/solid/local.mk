# Unit tests of src/solid.
check_PROGRAMS += tests/solid/test_constitutive
tests_solid_test_constitutive_SOURCES = tests/solid/test_constitutive.c
tests_solid_test_constitutive_LDADD = $(test_libs)
TESTS += tests/solid/test_constitutive

check_PROGRAMS += tests/solid/test_element
tests_solid_test_element_SOURCES = tests/solid/test_element.c
tests_solid_test_element_LDADD = $(test_libs)
TESTS += tests/solid/test_element

check_PROGRAMS += tests/solid/test_statics
tests_solid_test_statics_SOURCES = tests/solid/test_statics.c tests/solid/bench.h
tests_solid_test_statics_LDADD = $(test_libs)
TESTS += tests/solid/test_statics

check_PROGRAMS += tests/solid/test_dynamics
tests_solid_test_dynamics_SOURCES = tests/solid/test_dynamics.c tests/solid/bench.h
tests_solid_test_dynamics_LDADD = $(test_libs)
TESTS += tests/solid/test_dynamics

check_PROGRAMS += tests/solid/test_coupling
tests_solid_test_coupling_SOURCES = tests/solid/test_coupling.c tests/solid/bench.h
tests_solid_test_coupling_LDADD = $(test_libs)
TESTS += tests/solid/test_coupling

check_PROGRAMS += tests/solid/test_rigid_body
tests_solid_test_rigid_body_SOURCES = tests/solid/test_rigid_body.c tests/solid/bench.h
tests_solid_test_rigid_body_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_solid_test_rigid_body_LDADD = $(test_libs)
TESTS += tests/solid/test_rigid_body
