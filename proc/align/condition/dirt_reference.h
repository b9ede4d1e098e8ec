// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/condition/small_marks.h"
#include "proc/image/result.h"

namespace orbwatch::align {

/// Appearance of the clean ball, to be kept with its alignment: `dark` and `bright` the deepest
/// marks that its room has had in any light, `detail` the usual one, `judged` where those are
/// known. Valid for one place of camera, ball and outline.
using DirtReference = SmallMarks;

/// Error: maps that are not of 8 bit and kRasterSide squared. Reentrant.
Result<> check_reference(const DirtReference& reference);

/// A reference that covers both, for example lamps on and lamps off. Both are checked. Reentrant.
DirtReference joined(const DirtReference& a, const DirtReference& b);

}  // namespace orbwatch::align
