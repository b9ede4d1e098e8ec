// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/sink/sink.h"

namespace orbwatch::app::tests {

/// Passes a view to a sink like the pipeline: the sink is queried before.
inline void hand_over(Sink& sink, const ViewPtr& view) {
  sink.needs(view->index, view->stamp);
  sink.accept(view);
}

}  // namespace orbwatch::app::tests
