// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/sink/view.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/views/aim.h"
#include "app/ports/web/views/view_records.h"
#include "app/ports/web/web_context.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::web {

/// Lists all views with their content, the commands that apply to them, and their present aim.
/// Thread rule: accept on the pipeline's thread, which holds a lock only for a copy; list
/// on any thread.
class ViewList {
 public:
  explicit ViewList(const WebContext& context);

  Answered<ViewsAnswer> list() const;

  void accept(const View& view);

  /// Result of web::at_present() for the view's newest picture. On any thread.
  std::optional<Command> at_present(const Command& command) const;

 private:
  const std::vector<std::string> names_;
  const std::vector<PublishedView> views_;
  mutable hal::PriorityMutex mutex_;
  /// Aims of the newest pictures, by view; guarded by mutex_.
  std::vector<std::optional<Aim>> aims_;
};

}  // namespace orbwatch::app::web
