# Unit tests of src/math.
check_PROGRAMS += tests/math/test_expression
tests_math_test_expression_SOURCES = tests/math/test_expression.c
tests_math_test_expression_LDADD = $(test_libs)
TESTS += tests/math/test_expression

check_PROGRAMS += tests/math/test_sparse
tests_math_test_sparse_SOURCES = tests/math/test_sparse.c
tests_math_test_sparse_LDADD = $(test_libs)
TESTS += tests/math/test_sparse
