# Expressions and linear algebra.
libskerry_la_SOURCES += \
    src/math/expression.c src/math/expression.h \
    src/math/gmres.c src/math/gmres.h \
    src/math/sparse.c src/math/sparse.h
