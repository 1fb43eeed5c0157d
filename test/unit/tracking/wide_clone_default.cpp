// SPDX-License-Identifier: BSD-3-Clause
#define DATMO_FUSION_WIDE
#define datmo datmo_default
#include "wide_clone.h"
