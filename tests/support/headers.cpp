// SPDX-License-Identifier: Apache-2.0
// The precompiled header needs one file that uses it.
#include "tests/support/headers.h"
