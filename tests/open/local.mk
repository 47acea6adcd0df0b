# Unit tests of src/open.
check_PROGRAMS += tests/open/test_channel
tests_open_test_channel_SOURCES = tests/open/test_channel.c $(test_assembly)
tests_open_test_channel_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_open_test_channel_LDADD = $(test_libs)
TESTS += tests/open/test_channel
