// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

/// One function per verb: declares its options and what runs when it is chosen.
namespace trysquare::app {

void add_diagnose(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_compare(CLI::App& app);
void add_map(CLI::App& app);
void add_orthogonal(CLI::App& app);
void add_ape(CLI::App& app);
void add_rpe(CLI::App& app);
void add_simulate(CLI::App& app);
void add_info(CLI::App& app);
void add_convert(CLI::App& app);
void add_refine(CLI::App& app);
void add_perturb(CLI::App& app);
void add_experiment(CLI::App& app);
void add_completion(CLI::App& app);

}  // namespace trysquare::app
