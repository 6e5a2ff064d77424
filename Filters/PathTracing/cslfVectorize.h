// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Marks functions whose loops run over the lanes of a packet: compiled once for every generation of
 * vector instructions, of which the processor's newest is taken when the library is loaded.
 */
#ifndef cslfVectorize_h
#define cslfVectorize_h

// Sanitizers are not yet up when the choice is made.
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

// Stands before a loop over lanes: what it writes is nowhere what it reads of other lanes.
#if defined(__GNUC__) && !defined(__clang__)
#define CSLF_LANE_LOOP _Pragma("GCC ivdep")
#else
#define CSLF_LANE_LOOP
#endif

#endif
