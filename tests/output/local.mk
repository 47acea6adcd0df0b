# Unit tests of src/output.
check_PROGRAMS += tests/output/test_vtu
tests_output_test_vtu_SOURCES = tests/output/test_vtu.c tests/output/folder.h
tests_output_test_vtu_LDADD = $(test_libs)
TESTS += tests/output/test_vtu

check_PROGRAMS += tests/output/test_series
tests_output_test_series_SOURCES = tests/output/test_series.c tests/output/folder.h
tests_output_test_series_LDADD = $(test_libs)
TESTS += tests/output/test_series

check_PROGRAMS += tests/output/test_picture
tests_output_test_picture_SOURCES = tests/output/test_picture.c tests/output/folder.h
tests_output_test_picture_LDADD = $(test_libs) $(PNG_LIBS)
TESTS += tests/output/test_picture

# Other programs read what we write.
check_PROGRAMS += tests/output/write_samples
tests_output_write_samples_SOURCES = tests/output/write_samples.c
tests_output_write_samples_LDADD = libskerry.la
dist_check_SCRIPTS += tests/output/readers.sh
TESTS += tests/output/readers.sh

check_PROGRAMS += tests/output/test_checkpoint
tests_output_test_checkpoint_SOURCES = tests/output/test_checkpoint.c tests/output/folder.h
tests_output_test_checkpoint_LDADD = $(test_libs)
TESTS += tests/output/test_checkpoint
