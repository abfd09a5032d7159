// SPDX-License-Identifier: MIT
#pragma once

#include "app/options.h"

namespace spindrift::app
{

// The subcommands, one file each. They return the exit code and throw Error for bad input.

int run(const RunOptions& options);
int explain(const ExplainOptions& options);
int wind(const WindOptions& options);
int calibrate(const CalibrateOptions& options);
int validate(const ValidateOptions& options);
int report(const ReportOptions& options);
int info();
int list_scenes();
int study_sorts(const SortsOptions& options);

}  // namespace spindrift::app
