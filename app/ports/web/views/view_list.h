#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/model/command.h"
#include "app/model/view.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/routes.h"
#include "app/ports/web/views/aim.h"
#include "app/ports/web/web_context.h"

namespace orbwatch::app::web {

/// Says of all views what they show, whether they may be pointed and mixed, and how they are at
/// present. Thread rule: accept by the pipeline's thread, which holds a lock for a copy only; the
/// route on any.
class ViewList {
 public:
  explicit ViewList(const WebContext& context);

  Route route();

  void accept(const View& view);

  /// As at_present() of the view's newest picture. On any thread.
  std::optional<Command> at_present(const Command& command) const;

 private:
  void serve(const ExchangePtr& exchange) const;

  const std::vector<std::string> names_;
  const std::vector<PublishedView> views_;
  mutable std::mutex mutex_;
  std::vector<std::optional<Aim>> aims_;  ///< of the newest picture, by view; under mutex_
};

}  // namespace orbwatch::app::web
