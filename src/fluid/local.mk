libskerry_la_SOURCES += \
	src/fluid/fluid.c src/fluid/fluid.h src/fluid/fluid_internal.h src/fluid/fluid_list.h \
	src/fluid/fluid_fields.c src/fluid/fluid_lists.c src/fluid/fluid_walls.c \
	src/fluid/transport_velocity.c src/fluid/transport_velocity.h

# Pair sweeps: compiled once per instruction set and precision (top Makefile.am).
sweep_sources = src/fluid/transport_velocity_sweeps.c src/sph/sweep.h src/sph/sweep_vector.h
