// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/model/configuration_files.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/access/audit.h"
#include "app/ports/web/access/slow_work.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// Routes that read, check, try out and confirm the files of the configuration, and single limits
/// and regions of a recipe within its file. The configuration file itself determines where users
/// are kept and which camera modules run: changing it needs an administrator. Thread rule: start
/// and stop by one owner; the routes on any thread.
class ConfigurationDesk {
 public:
  /// `files` null: there are no routes. `access` and `audit` outlive the desk.
  ConfigurationDesk(std::shared_ptr<ConfigurationFiles> files, Access& access, Audit& audit);

  void start() { work_.start(); }
  void stop() { work_.stop(); }

  std::vector<Route> routes();

  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

 private:
  struct Sent;
  using Handler = Response (ConfigurationDesk::*)(Sent&);
  /// Parses a request's body into `sent`.
  using Read = Result<> (*)(std::string_view body, Sent& sent);

  Route changing(const char* path, const char* description, std::vector<BodyMember> body, Read read,
                 Handler handler);
  SlowWork::Asker asker(const ExchangePtr& exchange) const;
  Response answer_and_note(const ExchangePtr& exchange, Read read, Handler handler);

  Response show() const;
  Response check(Sent& sent);
  Response try_out(Sent& sent);
  Response check_recipe(Sent& sent);
  Response try_recipe(Sent& sent);
  Response confirm(Sent& sent);
  Response revert(Sent& sent);
  Result<> permit(const Sent& sent) const;
  Result<> check_basis(const Sent& sent) const;
  std::string changer_of(const std::string& name, const ConfigurationFiles::Version& now) const;
  Result<> apply_changes(Sent& sent) const;

  const std::shared_ptr<ConfigurationFiles> files_;
  Access& access_;
  Audit& audit_;
  SlowWork work_{"web files", "other users are changing the configuration at present; try again"};
};

}  // namespace orbwatch::app::web
