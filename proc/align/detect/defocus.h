// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/picture.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// True when the reflection is blurred so much that the outline found may be too large: a blurred
/// limb is found near the outer foot of its edge, by half of the blur disc's radius and more. False
/// when the blur cannot be measured. Reentrant; takes some milliseconds.
bool is_out_of_focus(const Picture& picture, const optics::Outline& outline);

}  // namespace orbwatch::align
