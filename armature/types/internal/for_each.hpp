// SPDX-License-Identifier: Apache-2.0
#pragma once

// Applies a macro to each of up to 256 arguments. The preprocessor expands a macro only once in a
// scan; each EXPAND scans its argument four more times.
#define ARMATURE_INTERNAL_PARENTHESES ()
#define ARMATURE_INTERNAL_EXPAND(...)                      \
  ARMATURE_INTERNAL_EXPAND_64(ARMATURE_INTERNAL_EXPAND_64( \
      ARMATURE_INTERNAL_EXPAND_64(ARMATURE_INTERNAL_EXPAND_64(__VA_ARGS__))))
#define ARMATURE_INTERNAL_EXPAND_64(...)                   \
  ARMATURE_INTERNAL_EXPAND_16(ARMATURE_INTERNAL_EXPAND_16( \
      ARMATURE_INTERNAL_EXPAND_16(ARMATURE_INTERNAL_EXPAND_16(__VA_ARGS__))))
#define ARMATURE_INTERNAL_EXPAND_16(...)                 \
  ARMATURE_INTERNAL_EXPAND_4(ARMATURE_INTERNAL_EXPAND_4( \
      ARMATURE_INTERNAL_EXPAND_4(ARMATURE_INTERNAL_EXPAND_4(__VA_ARGS__))))
#define ARMATURE_INTERNAL_EXPAND_4(...) \
  ARMATURE_INTERNAL_SCAN(               \
      ARMATURE_INTERNAL_SCAN(ARMATURE_INTERNAL_SCAN(ARMATURE_INTERNAL_SCAN(__VA_ARGS__))))
#define ARMATURE_INTERNAL_SCAN(...) __VA_ARGS__

/// `macro(context, first) macro(context, second) ...`
#define ARMATURE_INTERNAL_FOR_EACH(macro, context, ...) \
  __VA_OPT__(ARMATURE_INTERNAL_EXPAND(ARMATURE_INTERNAL_FOR_ONE(macro, context, __VA_ARGS__)))
#define ARMATURE_INTERNAL_FOR_ONE(macro, context, first, ...) \
  macro(context, first) __VA_OPT__(                           \
      ARMATURE_INTERNAL_FOR_NEXT ARMATURE_INTERNAL_PARENTHESES(macro, context, __VA_ARGS__))
#define ARMATURE_INTERNAL_FOR_NEXT() ARMATURE_INTERNAL_FOR_ONE

// Both `x` and `(x)` become `x`: the word KEEP in front either takes the parentheses or stays as it
// is, and is pasted away in both cases.
#define ARMATURE_INTERNAL_WITHOUT_PARENTHESES(argument) \
  ARMATURE_INTERNAL_DROP_WORD(ARMATURE_INTERNAL_KEEP argument)
#define ARMATURE_INTERNAL_KEEP(...) ARMATURE_INTERNAL_KEEP __VA_ARGS__
#define ARMATURE_INTERNAL_DROP_WORD(...) ARMATURE_INTERNAL_PASTE_DROP(__VA_ARGS__)
#define ARMATURE_INTERNAL_PASTE_DROP(...) ARMATURE_INTERNAL_DROP_##__VA_ARGS__
#define ARMATURE_INTERNAL_DROP_ARMATURE_INTERNAL_KEEP
