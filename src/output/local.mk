# Fields, series, histories and pictures.
libskerry_la_SOURCES += \
	src/output/appended.c src/output/appended.h \
	src/output/canvas.c src/output/canvas.h \
	src/output/checkpoint.c src/output/checkpoint.h src/output/checkpoint_internal.h \
	src/output/checkpoint_data.c src/output/checkpoint_manifest.c \
	src/output/colour_map.c src/output/colour_map.h \
	src/output/frame.c src/output/frame.h \
	src/output/history.c src/output/history.h \
	src/output/lettering.c src/output/lettering.h \
	src/output/picture.c src/output/picture.h \
	src/output/picture_parts.c src/output/picture_parts.h \
	src/output/pvd.c src/output/pvd.h \
	src/output/scene.c src/output/scene.h \
	src/output/series.c src/output/series.h \
	src/output/view.c src/output/view.h \
	src/output/vti.c src/output/vti.h \
	src/output/vtu.c src/output/vtu.h src/output/vtu_types.h \
	src/output/vtu_read.c \
	src/output/xml.c src/output/xml.h
