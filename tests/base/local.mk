# Unit tests of src/base.
check_PROGRAMS += tests/base/test_field
tests_base_test_field_SOURCES = tests/base/test_field.c
tests_base_test_field_LDADD = $(test_libs)
TESTS += tests/base/test_field

check_PROGRAMS += tests/base/test_file
tests_base_test_file_SOURCES = tests/base/test_file.c
tests_base_test_file_LDADD = $(test_libs)
TESTS += tests/base/test_file

check_PROGRAMS += tests/base/test_log
tests_base_test_log_SOURCES = tests/base/test_log.c
tests_base_test_log_LDADD = $(test_libs)
TESTS += tests/base/test_log

check_PROGRAMS += tests/base/test_memory
tests_base_test_memory_SOURCES = tests/base/test_memory.c
tests_base_test_memory_LDADD = $(test_libs)
TESTS += tests/base/test_memory

check_PROGRAMS += tests/base/test_parallel
tests_base_test_parallel_SOURCES = tests/base/test_parallel.c
tests_base_test_parallel_LDADD = $(test_libs)
TESTS += tests/base/test_parallel

check_PROGRAMS += tests/base/test_text
tests_base_test_text_SOURCES = tests/base/test_text.c
tests_base_test_text_LDADD = $(test_libs)
TESTS += tests/base/test_text

check_PROGRAMS += tests/base/test_hash
tests_base_test_hash_SOURCES = tests/base/test_hash.c
tests_base_test_hash_LDADD = $(test_libs)
TESTS += tests/base/test_hash
