// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "app/ports/web/web_sink.h"
#include "app/state/command_record.h"
#include "tests/app/hand_over.h"
#include "tests/app/ports/dds/test_status.h"
#include "tests/app/ports/dds/test_views.h"
#include "tests/app/ports/web/http_client.h"

namespace orbwatch::app::web::tests {

using app::tests::hand_over;
using app::tests::make_view;

inline WebContext make_context() {
  WebContext context;
  context.names = app::tests::make_names();
  context.views.resize(context.names.views.size());
  for (PublishedView& view : context.views) {
    view.spec.width = 64;
    view.spec.height = 48;
  }
  context.commands.record = std::make_shared<CommandRecord>();
  context.background = hal::SharedThreads::alone();
  return context;
}

inline WebSettings on_a_free_port(WebSettings settings = {}) {
  settings.enabled = true;
  settings.port = 0;
  return settings;
}

/// A sink that serves on a free port, with the names and the status of test_status.h.
class Served : public testing::Test {
 protected:
  void start(const WebSettings& settings = {}) {
    WebContext context = make_context();
    context.state_folder = state_folder;
    context.commands.handler = handler;
    context.program = program;
    context.tables = tables;
    context.metrics = metrics;
    context.fleet = fleet;
    context.recipes = recipes;
    serve(context, settings);
    if (HasFatalFailure()) return;
    sink->accept(app::tests::make_status());
  }
  void serve(const WebContext& context, const WebSettings& settings = {}) {
    sink = std::make_unique<WebSink>(on_a_free_port(settings), context);
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  int port() const { return sink->port(); }

  static bool eventually(const std::function<bool()>& condition) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > give_up) return false;
      // interval of polling a real server
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  /// Waits until the view has readers, and passes a picture like the pipeline.
  void show(std::uint64_t frame_set, int width = 64, int height = 48, std::size_t index = 0) const {
    const auto view = make_view(index, index == 0 ? "front" : "wide", frame_set, width, height);
    ASSERT_TRUE(eventually([&] { return sink->needs(index, view->stamp).jpeg; }));
    sink->accept(view);
  }

  std::filesystem::path state_folder;  ///< empty: no users
  CommandHandler handler;
  Program program;                                        ///< empty
  std::function<std::vector<InterfaceTable>()> tables;    ///< empty: none
  std::function<std::vector<InterfaceMetric>()> metrics;  ///< empty: none
  std::shared_ptr<Fleet> fleet;                           ///< null: no DDS
  std::vector<MeasuredRecipe> recipes;                    ///< none
  std::unique_ptr<WebSink> sink;
};

}  // namespace orbwatch::app::web::tests
