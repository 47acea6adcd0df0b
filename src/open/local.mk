libskerry_la_SOURCES += \
	src/open/inflow.c \
	src/open/open_list.h \
	src/open/outflow.c \
	src/open/zone.c src/open/zone.h
