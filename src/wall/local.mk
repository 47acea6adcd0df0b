# Sources of src/wall/.
libskerry_la_SOURCES += \
	src/wall/facet_shares.c src/wall/facet_shares.h \
	src/wall/fixed_particles.c \
	src/wall/material_points.c src/wall/material_points.h \
	src/wall/projection.c src/wall/projection.h \
	src/wall/sliding_contacts.c \
	src/wall/sliding_forces.c \
	src/wall/sliding_particles.c src/wall/sliding_particles.h \
	src/wall/wall_list.h \
	src/wall/wall_places.c src/wall/wall_places.h

# Compiled once per instruction set (top Makefile.am).
wall_sweep_sources = \
	src/wall/contact_sums_sweeps.c src/wall/contact_sums_sweeps.h \
	src/wall/facet_shares_sweeps.c src/wall/facet_shares_sweeps.h \
	src/sph/sweep_vector.h
