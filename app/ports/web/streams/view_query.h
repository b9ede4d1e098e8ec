// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/image/picture.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::web {

/// A request for one view.
struct ViewQuery {
  std::string view;
};
template <class Visitor>
void visit(Visitor& v, ViewQuery& query) {
  v.required("view", query.view, "Name of the view");
}

/// Widths at which pictures are displayed.
inline constexpr Range kShownWidths = Range::between(0, kMaxSide);

/// A request for pictures of one view.
struct PictureQuery : ViewQuery {
  int width = 0;
};
template <class Visitor>
void visit(Visitor& v, PictureQuery& query) {
  visit(v, static_cast<ViewQuery&>(query));
  v.optional("width", query.width, kShownWidths,
             "Width at which the pictures are displayed: the smallest size of the view that is at "
             "least as wide is sent, see widths of /api/v1/views and /api/v1/sphere; 0: the full "
             "size",
             "px");
}

}  // namespace orbwatch::app::web
