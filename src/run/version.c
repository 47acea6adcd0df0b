// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/version.h"

#include "revision.h"
#include "sph/isa.h"

#include <hdf5.h>
#include <muParserDLL.h>
#include <png.h>
#include <suitesparse/cholmod.h>
#include <zlib.h>

#ifdef __has_feature // clang
#define SANITIZED __has_feature(address_sanitizer)
#else
#define SANITIZED 0
#endif

void version_print(FILE *stream)
{
    muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
    fprintf(stream, "skerry %s (%s)\n", PACKAGE_VERSION, SKERRY_REVISION);
    fprintf(stream, "compiler        %s\n", __VERSION__);
#ifdef __OPTIMIZE__
    fprintf(stream, "optimised       yes\n");
#else
    fprintf(stream, "optimised       no\n");
#endif
#if defined(__SANITIZE_ADDRESS__) || SANITIZED
    fprintf(stream, "sanitizers      yes\n");
#endif
    fprintf(stream, "OpenMP          %d\n", _OPENMP);
    fprintf(stream, "CHOLMOD         %d.%d.%d\n", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION,
            CHOLMOD_SUBSUB_VERSION);
    fprintf(stream, "HDF5            %d.%d.%d\n", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE);
    fprintf(stream, "libpng          %s\n", png_get_libpng_ver(NULL));
    fprintf(stream, "muParser        %s\n", parser ? mupGetVersion(parser) : "?");
    fprintf(stream, "zlib            %s\n", zlibVersion());
    fprintf(stream, "instruction set %s\n", isa_name(isa_best()));
    if (parser)
        mupRelease(parser);
}
