#pragma once

#include "app/dds/dds_statistics.h"
#include "app/dds/ros/diagnostics.h"

namespace orbwatch::app {

/// The line "orbwatch: network": what became of samples, each reason with its count; those that are
/// 0 are left out. Warn when something was refused or given up. Reentrant.
Diagnostic diagnose_network(const DdsStatistics& network);

}  // namespace orbwatch::app
