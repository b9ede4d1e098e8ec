// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "app/ports/dds/dds_sink.h"
#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app::tests {

/// A sink without commands that offers views and cameras like these, by place in make_names().
inline dds::DdsSink sink_offering(DdsSettings settings, std::vector<PublishedView> views,
                                  std::vector<PublishedCamera> cameras = {}) {
  return dds::DdsSink(std::move(settings), make_names(), nullptr, dds::network_addresses,
                      std::make_shared<CommandRecord>(), hal::SharedThreads::alone(), {}, nullptr,
                      std::move(views), std::move(cameras));
}

}  // namespace orbwatch::app::tests
