dist_bin_SCRIPTS += tools/skerry-deckgen

# Limits of the machine, for skerry-bench; its multiply-adds are to be fused.
noinst_PROGRAMS += tools/skerry-machine
tools_skerry_machine_SOURCES = tools/machine.c
tools_skerry_machine_CFLAGS = $(AM_CFLAGS) -ffp-contract=fast
tools_skerry_machine_LDADD =

EXTRA_DIST += \
	tools/skerry-bench \
	tools/skerry-demo-report \
	tools/skerry-validate \
	tools/skerry_signal.py \
	tools/skerry_vtu.py
