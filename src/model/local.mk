# Sources of src/model/.
libskerry_la_SOURCES += src/model/geometry.c src/model/geometry.h
libskerry_la_SOURCES += src/model/motion.c src/model/motion.h
libskerry_la_SOURCES += src/model/surface.c src/model/surface.h
libskerry_la_SOURCES += src/model/model.c src/model/model.h
libskerry_la_SOURCES += src/model/surface_build.c src/model/surface_build.h
libskerry_la_SOURCES += src/model/mesh.c src/model/mesh.h
libskerry_la_SOURCES += src/model/particles.c src/model/particles.h
