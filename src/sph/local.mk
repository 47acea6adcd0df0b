libskerry_la_SOURCES += \
	src/sph/boundary.c src/sph/boundary.h \
	src/sph/cell_grid.c src/sph/cell_grid.h \
	src/sph/isa.c src/sph/isa.h \
	src/sph/kernel.h \
	src/sph/neighbour_list.c src/sph/neighbour_list.h \
	src/sph/open_boundary.h \
	src/sph/shepard.c src/sph/shepard.h \
	src/sph/turning_load.c src/sph/turning_load.h

# Compiled once per instruction set (top Makefile.am).
filter_sources = src/sph/neighbour_filter.c src/sph/sweep_vector.h
