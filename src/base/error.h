// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

/** Status of every function of the engine that can fail; the values are the exit codes of the program
 * (sysexits.h), so that main returns what it got. */
enum status {
    STATUS_OK = 0,
    STATUS_USAGE = 64,     /**< the command line is wrong */
    STATUS_DECK = 65,      /**< the deck, or a file named in it, is wrong */
    STATUS_NO_INPUT = 66,  /**< the deck itself cannot be read */
    STATUS_NUMERICAL = 70, /**< NaN, divergence, escaped particle, inverted element */
    STATUS_MEMORY = 71,    /**< out of memory */
    STATUS_CREATE = 73,    /**< the output cannot be created */
    STATUS_IO = 74,        /**< reading or writing failed */
    STATUS_STOPPED = 75    /**< stopped early with a checkpoint */
};

/** Report an error where it happens (to the log, prefixed with "skerry: error: ") and return its status.
 * @param status one of enum status, returned unchanged
 * @param format printf format of one line: location, what is wrong, what would be right; no newline */
int error_report(int status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Report and return @p status from the calling function unless @p condition holds. */
#define CHECK(condition, status, ...)                                                                        \
    do {                                                                                                     \
        if (!(condition))                                                                                    \
            return error_report((status), __VA_ARGS__);                                                      \
    } while (0)

/** Return the status of @p call from the calling function unless it is 0. */
#define CALL(call)                                                                                           \
    do {                                                                                                     \
        int call_status_ = (call);                                                                           \
        if (call_status_)                                                                                    \
            return call_status_;                                                                             \
    } while (0)

#endif
