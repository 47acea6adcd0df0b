# SPDX-License-Identifier: GPL-3.0-or-later

# SKERRY_TAKE_FLAG(FLAG, VARIABLE)
# Move FLAG from CFLAGS to the substituted VARIABLE (empty if it is not there).
AC_DEFUN([SKERRY_TAKE_FLAG], [
    AC_SUBST([$2], [])
    skerry_rest=
    for skerry_flag in $CFLAGS; do
        AS_IF([test "x$skerry_flag" = "x$1"], [$2="$1"], [AS_VAR_APPEND([skerry_rest], [" $skerry_flag"])])
    done
    CFLAGS=$skerry_rest
])

# SKERRY_LIBRARIES_BEGIN ... SKERRY_LIBRARIES_END
# In between, SKERRY_MISSING(PACKAGE) notes a Debian package to install; the end names all of them at once.
AC_DEFUN([SKERRY_LIBRARIES_BEGIN], [
    skerry_missing=
    PKG_PROG_PKG_CONFIG
    AS_IF([test -z "$PKG_CONFIG"], [SKERRY_MISSING([pkg-config])])
])
AC_DEFUN([SKERRY_MISSING], [AS_VAR_APPEND([skerry_missing], [" $1"])])
AC_DEFUN([SKERRY_LIBRARIES_END], [
    AS_IF([test -n "$skerry_missing"], [AC_MSG_ERROR([libraries are missing.
  Debian and Ubuntu: apt-get install$skerry_missing])])
])

# SKERRY_PKG(VARIABLE, PKG-CONFIG MODULE, DEBIAN PACKAGE)
AC_DEFUN([SKERRY_PKG], [PKG_CHECK_MODULES([$1], [$2], [], [SKERRY_MISSING([$3])])])

# SKERRY_UDUNITS: UDUNITS_CFLAGS, UDUNITS_LIBS; older packages have no pkg-config file.
AC_DEFUN([SKERRY_UDUNITS], [
    PKG_CHECK_MODULES([UDUNITS], [udunits], [], [
        AC_CHECK_HEADER([udunits2.h],
            [AC_CHECK_LIB([udunits2], [ut_read_xml], [UDUNITS_LIBS=-ludunits2], [SKERRY_MISSING([libudunits2-dev])])],
            [SKERRY_MISSING([libudunits2-dev])])
    ])
])

# SKERRY_SUITESPARSE: SUITESPARSE_CFLAGS, SUITESPARSE_LIBS of CHOLMOD and UMFPACK, which have no pkg-config file.
AC_DEFUN([SKERRY_SUITESPARSE], [
    AC_ARG_VAR([SUITESPARSE_CFLAGS], [compiler flags for SuiteSparse])
    AC_ARG_VAR([SUITESPARSE_LIBS], [linker flags for SuiteSparse])
    AS_IF([test -z "$SUITESPARSE_LIBS"],
        [SUITESPARSE_LIBS="-lumfpack -lcholmod -lccolamd -lcamd -lcolamd -lamd -lsuitesparseconfig"])
    skerry_libs=$LIBS
    skerry_cppflags=$CPPFLAGS
    LIBS="$SUITESPARSE_LIBS $LIBS"
    CPPFLAGS="$CPPFLAGS $SUITESPARSE_CFLAGS"
    AC_MSG_CHECKING([for CHOLMOD and UMFPACK])
    AC_LINK_IFELSE([AC_LANG_PROGRAM([[#include <suitesparse/cholmod.h>
#include <suitesparse/umfpack.h>]], [[cholmod_common common; cholmod_l_start(&common); umfpack_dl_defaults((double *)0);]])],
        [AC_MSG_RESULT([yes])],
        [AC_MSG_RESULT([no])
        SKERRY_MISSING([libsuitesparse-dev])])
    LIBS=$skerry_libs
    CPPFLAGS=$skerry_cppflags
])

# SKERRY_OPENBLAS: skerry_blas = openblas or reference; OPENBLAS_LIBS and HAVE_OPENBLAS_SET_NUM_THREADS.
AC_DEFUN([SKERRY_OPENBLAS], [
    AC_SUBST([OPENBLAS_LIBS], [])
    skerry_blas=reference
    AC_CHECK_LIB([openblas], [openblas_set_num_threads], [
        skerry_blas=openblas
        OPENBLAS_LIBS=-lopenblas
        AC_DEFINE([HAVE_OPENBLAS_SET_NUM_THREADS], [1], [Whether the threads of OpenBLAS can be set.])
    ])
])
