// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Marks functions with loops over the lanes of a packet. They are compiled for every generation of
 * vector instructions, and the newest one of the processor is chosen when the library is loaded.
 */
#ifndef cslfVectorize_h
#define cslfVectorize_h

// Sanitizers are not initialised yet when the choice is made.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&       \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define CSLF_VECTORIZE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CSLF_VECTORIZE __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
#else
#define CSLF_VECTORIZE
#endif

// Precedes a loop over lanes in which no lane reads what another lane writes.
#if defined(__GNUC__) && !defined(__clang__)
#define CSLF_LANE_LOOP _Pragma("GCC ivdep")
#else
#define CSLF_LANE_LOOP
#endif

#endif
