// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_VTU_TYPES_H
#define OUTPUT_VTU_TYPES_H

#include "output/vtu.h"

/** What the writer and the reader of .vtu files have to agree on. */

enum { VTU_BLOCK = 128 * 1024 }; /**< bytes compressed as one piece */

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define VTU_BYTE_ORDER "BigEndian"
#else
#define VTU_BYTE_ORDER "LittleEndian"
#endif

#define VTU_APPENDED "<AppendedData encoding=\"raw\">\n_"
#define VTU_END "\n</AppendedData>\n</VTKFile>\n"

/** Bytes of one number. */
static inline size_t vtu_type_size(enum vtu_type type)
{
    return type == VTU_UINT8 ? 1 : type == VTU_FLOAT32 || type == VTU_INT32 ? 4 : 8;
}

/** VTK's name of a type. */
static inline const char *vtu_type_name(enum vtu_type type)
{
    static const char *const names[] = {"Float32", "Float64", "Int32", "Int64", "UInt8"};
    return names[type];
}

#endif
