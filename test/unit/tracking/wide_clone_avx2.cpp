// SPDX-License-Identifier: BSD-3-Clause
#if defined(__x86_64__)
#define DATMO_FUSION_WIDE __attribute__((target("avx2")))
#define datmo datmo_avx2
#include "wide_clone.h"
#endif
