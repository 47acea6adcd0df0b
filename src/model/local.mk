# Sources of src/model/.
libskerry_la_SOURCES += src/model/geometry.c src/model/geometry.h
libskerry_la_SOURCES += src/model/motion.c src/model/motion.h
libskerry_la_SOURCES += src/model/surface.c src/model/surface.h
libskerry_la_SOURCES += src/model/model.c src/model/model.h
libskerry_la_SOURCES += src/model/surface_build.c src/model/surface_build.h
libskerry_la_SOURCES += src/model/surface_rims.c src/model/surface_rims.h
libskerry_la_SOURCES += src/model/element_shape.c src/model/mesh_convert.c
libskerry_la_SOURCES += src/model/mesh.c src/model/mesh.h src/model/mesh_disc.c src/model/mesh_moments.c
libskerry_la_SOURCES += src/model/mesh_search.c src/model/mesh_search.h
libskerry_la_SOURCES += src/model/particles.c src/model/particles.h
