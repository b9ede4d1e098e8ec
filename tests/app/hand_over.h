#pragma once

#include "app/model/sink.h"

namespace orbwatch::app::tests {

/// A view on its way to a sink as the pipeline does it: the sink is asked before.
inline void hand_over(Sink& sink, const ViewPtr& view) {
  sink.needs(view->index, view->stamp);
  sink.accept(view);
}

}  // namespace orbwatch::app::tests
