# The rules of the house as tests.
rules = \
    tests/rules/check_aarch64.sh \
    tests/rules/check_format.sh \
    tests/rules/check_includes.sh \
    tests/rules/check_spdx.sh \
    tests/rules/check_symbols.sh
dist_check_SCRIPTS += $(rules)
TESTS += $(rules)
