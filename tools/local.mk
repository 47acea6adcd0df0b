dist_bin_SCRIPTS += tools/skerry-deckgen

# Limits of the machine, for skerry-bench; its multiply-adds are to be fused.
noinst_PROGRAMS += tools/skerry-machine
tools_skerry_machine_SOURCES = tools/machine.c
tools_skerry_machine_CFLAGS = $(AM_CFLAGS) -ffp-contract=fast
tools_skerry_machine_LDADD =

# The sweeps' frame under a formulation with one evaluation, for skerry-bench.
noinst_PROGRAMS += tools/skerry-pass
tools_skerry_pass_SOURCES = tools/pass.c tools/pass.h
tools_skerry_pass_LDADD = $(pass_libraries) libskerry.la
pass_sources = tools/pass_sweeps.c tools/pass.h

EXTRA_DIST += \
	tools/skerry-bench \
	tools/skerry-demo-report \
	tools/skerry-validate \
	tools/skerry_signal.py \
	tools/skerry_vtu.py
