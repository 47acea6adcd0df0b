check_PROGRAMS += tests/fluid/test_transport_velocity
tests_fluid_test_transport_velocity_SOURCES = tests/fluid/test_transport_velocity.c \
	tests/fluid/fluid_case.c tests/fluid/fluid_case.h
tests_fluid_test_transport_velocity_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_fluid_test_transport_velocity_LDADD = $(test_libs)
TESTS += tests/fluid/test_transport_velocity
