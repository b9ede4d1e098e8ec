#pragma once

#include "proc/align/condition/small_marks.h"
#include "proc/image/result.h"

namespace orbwatch::align {

/// What a clean ball shows, to be kept with its alignment: `dark` and `bright` the deepest marks
/// that its room has had in any light, `detail` the usual one, `judged` where that is known.
/// Belongs to one place of camera, ball and outline.
using DirtReference = SmallMarks;

/// Error: maps that are not of 8 bit and kRasterSide squared. Reentrant.
Result<> check_reference(const DirtReference& reference);

/// A reference that knows both, as of lamps on and lamps off. Both are checked. Reentrant.
DirtReference joined(const DirtReference& a, const DirtReference& b);

}  // namespace orbwatch::align
