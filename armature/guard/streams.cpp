// SPDX-License-Identifier: Apache-2.0
// Streams of C, and with them std::cout: their calls into the system happen inside the C library,
// where nobody can stand in front of them.
#include <cstdarg>
#include <cstdio>

#include "armature/guard/internal/watch.hpp"

namespace armature::guard {

ARMATURE_GUARD(FILE*, fopen, (const char* name, const char* mode), (name, mode), path(name))
ARMATURE_GUARD(FILE*, fopen64, (const char* name, const char* mode), (name, mode), path(name))
ARMATURE_GUARD(int, fclose, (FILE * stream), (stream))
ARMATURE_GUARD(int, fflush, (FILE * stream), (stream))
ARMATURE_GUARD(std::size_t, fread, (void* to, std::size_t size, std::size_t count, FILE* stream),
               (to, size, count, stream), bytes(size* count))
ARMATURE_GUARD(std::size_t, fwrite,
               (const void* from, std::size_t size, std::size_t count, FILE* stream),
               (from, size, count, stream), bytes(size* count))
ARMATURE_GUARD(char*, fgets, (char* to, int size, FILE* stream), (to, size, stream))
ARMATURE_GUARD(int, fgetc, (FILE * stream), (stream))
ARMATURE_GUARD(int, getc, (FILE * stream), (stream))
ARMATURE_GUARD(int, fputs, (const char* text, FILE* stream), (text, stream))
ARMATURE_GUARD(int, fputc, (int letter, FILE* stream), (letter, stream))
ARMATURE_GUARD(int, putc, (int letter, FILE* stream), (letter, stream))
ARMATURE_GUARD(int, putchar, (int letter), (letter))
ARMATURE_GUARD(int, puts, (const char* text), (text))
ARMATURE_GUARD(void, perror, (const char* text), (text))
ARMATURE_GUARD(int, vprintf, (const char* format, va_list values), (format, values), path(format))
ARMATURE_GUARD(int, vfprintf, (FILE * stream, const char* format, va_list values),
               (stream, format, values), path(format))
ARMATURE_GUARD(int, vdprintf, (int fd, const char* format, va_list values), (fd, format, values),
               path(format))
ARMATURE_GUARD(int, __vprintf_chk, (int flag, const char* format, va_list values),
               (flag, format, values), path(format))
ARMATURE_GUARD(int, __vfprintf_chk, (FILE * stream, int flag, const char* format, va_list values),
               (stream, flag, format, values), path(format))

/// A function with values behind its format, by way of `v_name`, which takes them in a list.
#define ARMATURE_GUARD_PRINT(name, v_name, parameters, arguments)              \
  ARMATURE_GUARD_FUNCTION(int, name, parameters) {                             \
    static constinit std::atomic<decltype(&guarded_##v_name)> behind{nullptr}; \
    ARMATURE_GUARD_NOTE(name, path(format));                                   \
    va_list values;                                                            \
    va_start(values, format);                                                  \
    const int printed = next(behind, #v_name) arguments;                       \
    va_end(values);                                                            \
    return printed;                                                            \
  }

ARMATURE_GUARD_PRINT(printf, vprintf, (const char* format, ...), (format, values))
ARMATURE_GUARD_PRINT(fprintf, vfprintf, (FILE * stream, const char* format, ...),
                     (stream, format, values))
ARMATURE_GUARD_PRINT(dprintf, vdprintf, (int fd, const char* format, ...), (fd, format, values))
ARMATURE_GUARD_PRINT(__printf_chk, __vprintf_chk, (int flag, const char* format, ...),
                     (flag, format, values))
ARMATURE_GUARD_PRINT(__fprintf_chk, __vfprintf_chk,
                     (FILE * stream, int flag, const char* format, ...),
                     (stream, flag, format, values))

}  // namespace armature::guard
