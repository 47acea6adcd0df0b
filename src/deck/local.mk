# Reading decks.
libskerry_la_SOURCES += \
    src/deck/deck.c src/deck/deck.h \
    src/deck/deck_boundary.c \
    src/deck/deck_coupling.c \
    src/deck/deck_error.c \
    src/deck/deck_fluid.c \
    src/deck/deck_help.c \
    src/deck/deck_list.c \
    src/deck/deck_material.c \
    src/deck/deck_mesh.c \
    src/deck/deck_motion.c \
    src/deck/deck_node.h \
    src/deck/deck_output.c \
    src/deck/deck_parameters.c \
    src/deck/deck_position.c src/deck/deck_position.h \
    src/deck/deck_resume.c \
    src/deck/deck_rigid.c \
    src/deck/deck_schema.c src/deck/deck_schema.h \
    src/deck/deck_show.c \
    src/deck/deck_surface.c \
    src/deck/deck_tree.c \
    src/deck/deck_value.c \
    src/deck/deck_xml.c \
    src/deck/unit.c src/deck/unit.h
