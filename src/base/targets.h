/// Functions marked PALPATION_TARGETS are one source, compiled for several instruction sets, chosen
/// when the program starts. No contraction to fused multiply-add (see palpation_targets.cmake), so
/// that all give the same digits.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PALPATION_TARGETS \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define PALPATION_TARGETS
#endif
