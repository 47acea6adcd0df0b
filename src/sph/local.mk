libskerry_la_SOURCES += \
	src/sph/boundary.c src/sph/boundary.h \
	src/sph/cell_grid.c src/sph/cell_grid.h \
	src/sph/kernel.h \
	src/sph/neighbour_list.c src/sph/neighbour_list.h \
	src/sph/open_boundary.h
