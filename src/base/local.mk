# Shared ground: errors, log, memory, files, threads.
libskerry_la_SOURCES += \
    src/base/error.c src/base/error.h \
    src/base/field.c src/base/field.h \
    src/base/file.c src/base/file.h \
    src/base/hash.c src/base/hash.h \
    src/base/log.c src/base/log.h \
    src/base/memory.c src/base/memory.h \
    src/base/parallel.c src/base/parallel.h \
    src/base/text.c src/base/text.h \
    src/base/timer.c src/base/timer.h
