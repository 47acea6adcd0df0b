# Unit tests of src/deck.
check_PROGRAMS += tests/deck/test_deck
tests_deck_test_deck_SOURCES = tests/deck/test_deck.c tests/deck/decks.h
tests_deck_test_deck_LDADD = $(test_libs)
TESTS += tests/deck/test_deck

check_PROGRAMS += tests/deck/test_deck_position
tests_deck_test_deck_position_SOURCES = tests/deck/test_deck_position.c
tests_deck_test_deck_position_LDADD = $(test_libs)
TESTS += tests/deck/test_deck_position

check_PROGRAMS += tests/deck/test_deck_resume
tests_deck_test_deck_resume_SOURCES = tests/deck/test_deck_resume.c
tests_deck_test_deck_resume_LDADD = $(test_libs)
TESTS += tests/deck/test_deck_resume

check_PROGRAMS += tests/deck/test_unit
tests_deck_test_unit_SOURCES = tests/deck/test_unit.c
tests_deck_test_unit_LDADD = $(test_libs)
TESTS += tests/deck/test_unit
