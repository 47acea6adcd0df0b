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
