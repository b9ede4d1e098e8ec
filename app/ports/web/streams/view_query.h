// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace orbwatch::app::web {

/// A request for one view.
struct ViewQuery {
  std::string view;
};
template <class Visitor>
void visit(Visitor& v, ViewQuery& query) {
  v.required("view", query.view, "Name of the view");
}

}  // namespace orbwatch::app::web
