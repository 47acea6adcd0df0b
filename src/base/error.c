// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"

#include "base/log.h"

#include <stdarg.h>

int error_report(int status, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    log_message_v(LOG_ERROR, format, arguments);
    va_end(arguments);
    return status;
}
