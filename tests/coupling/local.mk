# Unit tests of src/coupling.
check_PROGRAMS += tests/coupling/test_relaxation
tests_coupling_test_relaxation_SOURCES = tests/coupling/test_relaxation.c
tests_coupling_test_relaxation_LDADD = $(test_libs)
TESTS += tests/coupling/test_relaxation

check_PROGRAMS += tests/coupling/test_sub_cycled
tests_coupling_test_sub_cycled_SOURCES = tests/coupling/test_sub_cycled.c tests/run/beam_deck.h $(test_assembly)
tests_coupling_test_sub_cycled_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_coupling_test_sub_cycled_LDADD = $(test_libs)
TESTS += tests/coupling/test_sub_cycled

check_PROGRAMS += tests/coupling/test_quasi_newton
tests_coupling_test_quasi_newton_SOURCES = tests/coupling/test_quasi_newton.c
tests_coupling_test_quasi_newton_LDADD = $(test_libs)
TESTS += tests/coupling/test_quasi_newton

check_PROGRAMS += tests/coupling/test_fixed_point
tests_coupling_test_fixed_point_SOURCES = tests/coupling/test_fixed_point.c tests/run/beam_deck.h $(test_assembly)
tests_coupling_test_fixed_point_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_coupling_test_fixed_point_LDADD = $(test_libs)
TESTS += tests/coupling/test_fixed_point

check_PROGRAMS += tests/coupling/test_material_particles
tests_coupling_test_material_particles_SOURCES = tests/coupling/test_material_particles.c tests/run/beam_deck.h \
	$(test_assembly)
tests_coupling_test_material_particles_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_coupling_test_material_particles_LDADD = $(test_libs)
TESTS += tests/coupling/test_material_particles

check_PROGRAMS += tests/coupling/test_rigid_bodies
tests_coupling_test_rigid_bodies_SOURCES = tests/coupling/test_rigid_bodies.c $(test_assembly)
tests_coupling_test_rigid_bodies_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_coupling_test_rigid_bodies_LDADD = $(test_libs)
TESTS += tests/coupling/test_rigid_bodies
