check_PROGRAMS += tests/model/test_geometry
tests_model_test_geometry_SOURCES = tests/model/test_geometry.c
tests_model_test_geometry_LDADD = $(test_libs)
TESTS += tests/model/test_geometry

check_PROGRAMS += tests/model/test_motion
tests_model_test_motion_SOURCES = tests/model/test_motion.c
tests_model_test_motion_LDADD = $(test_libs)
TESTS += tests/model/test_motion

check_PROGRAMS += tests/model/test_surface
tests_model_test_surface_SOURCES = tests/model/test_surface.c
tests_model_test_surface_LDADD = $(test_libs)
TESTS += tests/model/test_surface

check_PROGRAMS += tests/model/test_mesh
tests_model_test_mesh_SOURCES = tests/model/test_mesh.c
tests_model_test_mesh_LDADD = $(test_libs)
TESTS += tests/model/test_mesh

check_PROGRAMS += tests/model/test_particles
tests_model_test_particles_SOURCES = tests/model/test_particles.c
tests_model_test_particles_LDADD = $(test_libs)
TESTS += tests/model/test_particles

check_PROGRAMS += tests/model/test_surface_build
tests_model_test_surface_build_SOURCES = tests/model/test_surface_build.c
tests_model_test_surface_build_LDADD = $(test_libs)
TESTS += tests/model/test_surface_build

check_PROGRAMS += tests/model/test_surface_rims
tests_model_test_surface_rims_SOURCES = tests/model/test_surface_rims.c
tests_model_test_surface_rims_LDADD = $(test_libs)
TESTS += tests/model/test_surface_rims

check_PROGRAMS += tests/model/test_mesh_search
tests_model_test_mesh_search_SOURCES = tests/model/test_mesh_search.c
tests_model_test_mesh_search_LDADD = $(test_libs)
TESTS += tests/model/test_mesh_search
