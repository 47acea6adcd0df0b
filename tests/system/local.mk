# Files of tests/system.
dist_check_SCRIPTS += tests/system/test_deckgen.sh tests/system/test_tools.sh tests/system/test_exact.sh
EXTRA_DIST += tests/system/test_tools.py tests/system/test_exact.py
TESTS += tests/system/test_deckgen.sh tests/system/test_tools.sh tests/system/test_exact.sh

# Decks that must be refused, and the command line.
dist_check_SCRIPTS += tests/system/test_bad_decks.sh tests/system/test_cli.sh
EXTRA_DIST += tests/decks-bad tests/system/control.xml
TESTS += tests/system/test_bad_decks.sh tests/system/test_cli.sh

# Runs that end early.
dist_check_SCRIPTS += tests/system/test_failures.sh
TESTS += tests/system/test_failures.sh

# Interrupted runs.
dist_check_SCRIPTS += tests/system/test_resume.sh
EXTRA_DIST += tests/system/test_resume.py tests/system/resume_decks.py
TESTS += tests/system/test_resume.sh

# Kinds of elements and laws.
dist_check_SCRIPTS += tests/system/test_elements.sh
EXTRA_DIST += tests/system/test_elements.py
TESTS += tests/system/test_elements.sh

# Faults from outside.
dist_check_SCRIPTS += tests/system/test_faults.sh
EXTRA_DIST += tests/system/test_faults.py
TESTS += tests/system/test_faults.sh

# Numbers of threads.
dist_check_SCRIPTS += tests/system/test_threads.sh
EXTRA_DIST += tests/system/test_threads.py
TESTS += tests/system/test_threads.sh

# Coarse runs of the paper benchmarks.
dist_check_SCRIPTS += tests/system/test_benchmarks.sh
EXTRA_DIST += tests/system/test_benchmarks.py
TESTS += tests/system/test_benchmarks.sh

# Fields at places.
dist_check_SCRIPTS += tests/system/test_probe.sh
EXTRA_DIST += tests/system/test_probe.py
TESTS += tests/system/test_probe.sh
