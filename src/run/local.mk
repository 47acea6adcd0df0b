libskerry_la_SOURCES += \
	src/run/folder.c src/run/folder.h \
	src/run/frames.c src/run/frames.h \
	src/run/interrupt.c src/run/interrupt.h \
	src/run/json.c src/run/json.h \
	src/run/monitor.c src/run/monitor.h \
	src/run/preview.c src/run/preview.h \
	src/run/preview_physics.c src/run/preview_physics.h \
	src/run/probe.c src/run/probe.h \
	src/run/probe_places.c src/run/probe_places.h \
	src/run/probe_sums.c src/run/probe_sums.h \
	src/run/progress.c src/run/progress.h \
	src/run/record.c src/run/record.h \
	src/run/saver.c src/run/saver.h \
	src/run/simulation.c src/run/simulation.h \
	src/run/status.c src/run/status.h \
	src/run/summary.c src/run/summary.h \
	src/run/version.c src/run/version.h
