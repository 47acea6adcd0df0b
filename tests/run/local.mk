# Unit tests of src/run.
check_PROGRAMS += tests/run/test_progress
tests_run_test_progress_SOURCES = tests/run/test_progress.c
tests_run_test_progress_LDADD = $(test_libs)
TESTS += tests/run/test_progress

check_PROGRAMS += tests/run/test_summary
tests_run_test_summary_SOURCES = tests/run/test_summary.c
tests_run_test_summary_LDADD = $(test_libs)
TESTS += tests/run/test_summary

check_PROGRAMS += tests/run/test_preview
tests_run_test_preview_SOURCES = tests/run/test_preview.c
tests_run_test_preview_LDADD = $(test_libs)
TESTS += tests/run/test_preview

# A whole run without output, for tests of any folder that need one.
test_assembly = tests/run/assembly.c tests/run/assembly.h

check_PROGRAMS += tests/run/test_contracts
tests_run_test_contracts_SOURCES = tests/run/test_contracts.c tests/run/beam_deck.h $(test_assembly)
tests_run_test_contracts_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests
tests_run_test_contracts_LDADD = $(test_libs)
TESTS += tests/run/test_contracts

check_PROGRAMS += tests/run/test_schedule
tests_run_test_schedule_SOURCES = tests/run/test_schedule.c
tests_run_test_schedule_LDADD = $(test_libs)
TESTS += tests/run/test_schedule

check_PROGRAMS += tests/run/test_status
tests_run_test_status_SOURCES = tests/run/test_status.c
tests_run_test_status_LDADD = $(test_libs)
TESTS += tests/run/test_status

check_PROGRAMS += tests/run/test_record
tests_run_test_record_SOURCES = tests/run/test_record.c
tests_run_test_record_LDADD = $(test_libs)
TESTS += tests/run/test_record
