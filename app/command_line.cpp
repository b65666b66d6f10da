#include "app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "app/build_info.hpp"
#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/options.hpp"
#include "app/output.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "studies/listing.hpp"
#include "studies/registry.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/study.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::app {

namespace {

/// One line on standard error, whatever the message quotes.
int complain(std::string message, ExitCode code) {
  message = core::printable(std::move(message));
  std::ranges::replace_if(
      message, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  say(fmt::format("ridgeloc: {}\n", message));
  return code;
}

studies::Shard shard_of(const std::string& text) {
  studies::Shard shard;
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto count = slash ? std::from_chars(number.ptr + 1, end, shard.count) : number;
  const bool read = slash && count.ec == std::errc() && count.ptr == end;
  if (!read || shard.number < 1 || shard.number > shard.count || shard.count > studies::max_shards) {
    throw core::InputError(fmt::format("--shard {}: write it as i/N with i from 1 to N and N up to {}, for example 2/7",
                                       text, studies::max_shards));
  }
  return shard;
}

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const studies::Experiment* e : studies::experiment_registry()) names.emplace_back(e->name());
  return names;
}

/// The verbs with their options, and what the chosen one does.
class CommandLine {
 public:
  CommandLine() {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", "ridgeloc " + build_provenance().program_version);
    app_.footer(
        "Exit codes: 0 done, 1 verify or compare found a difference, 2 bad input, 3 reading or writing failed, 4 "
        "stopped by a signal "
        "or a time limit (finished work kept).");

    CLI::App& list_verb =
        verb("list", "what there is: solvers, K estimators, metrics, studies, ...", [this] { return list(list_); });
    list_verb.add_option("TOPIC", list_.topic, "one topic only")->check(CLI::IsMember(studies::listing_topics()));

    CLI::App& new_verb = verb("new", "print a commented study file to start from", [this] { return new_study(new_); });
    new_verb.add_option("EXPERIMENT", new_.experiment)->required()->check(CLI::IsMember(experiment_names()));
    new_verb.add_option("-o", new_.output, "file to write")->type_name("FILE");

    CLI::App& plan_verb =
        verb("plan", "cells, blocks, time and disk of a study, without running it", [this] { return plan(plan_); });
    add_study_options(plan_verb, plan_.study);
    CLI::Option* slurm =
        plan_verb.add_option("--slurm", plan_.slurm, "write a script that runs the study as a job array of Slurm")
            ->type_name("FILE");
    plan_verb
        .add_option("--shards", plan_.shares, "tasks of this array (default: so many that each takes about an hour)")
        ->check(CLI::Range(std::uint64_t{2}, studies::max_shards))
        ->type_name("N")
        ->needs(slurm);

    CLI::App& run_verb = verb("run", "run studies; goes on where a stopped run of the same study left off",
                              [this] { return run(run_); });
    add_study_options(run_verb, run_.study);
    run_verb.add_option("-o", run_.output, "result file, or a folder for several studies")->type_name("PATH");
    run_verb
        .add_option_function<std::string>(
            "--shard", [this](const std::string& text) { run_.shard = shard_of(text); },
            "compute one of N shares only, i from 1 to N; merge puts them together")
        ->type_name("i/N");
    run_verb
        .add_option_function<std::string>(
            "--time-limit", [this](const std::string& text) { run_.time_limit_s = seconds_of(text); },
            "stop after this time (90s, 10m, 1h30m, HH:MM:SS) and keep all")
        ->type_name("TIME");

    CLI::App& merge_verb = verb("merge", "put results of one study together: shards, or more trials, cells, methods",
                                [this] { return merge(merge_); });
    merge_verb.add_option("RESULT", merge_.results, "result files")->required();
    merge_verb.add_option("-o", merge_.output, "result file to write")->required()->type_name("FILE");
    merge_verb.add_flag(
        "--mix-isa", merge_.mix_isa,
        "let results of different instruction sets stand side by side, which ends exact reproducibility");

    CLI::App& compare_verb = verb("compare", "compare two results of one study, from other machines, versions or seeds",
                                  [this] { return compare(compare_); });
    compare_verb.add_option("A", compare_.first, "result file")->required();
    compare_verb.add_option("B", compare_.second, "result file")->required();

    CLI::App& verify_verb =
        verb("verify", "check a result, and compute some of its blocks again", [this] { return verify(verify_); });
    verify_verb.add_option("RESULT", verify_.result, "result file")->required();
    CLI::Option* blocks = verify_verb.add_option("--blocks", verify_.blocks, "random blocks to compute again")
                              ->default_val(verify_.blocks)
                              ->check(CLI::Range(std::uint64_t{0}, studies::max_trials))
                              ->type_name("N");
    CLI::Option* seed =
        verify_verb.add_option("--seed", verify_.seed, "chooses the blocks (default: others each time)")
            ->type_name("N");
    verify_verb.add_flag("--digest", verify_.digest, "only print the digest of the data")
        ->excludes(blocks)
        ->excludes(seed);
    add_threads(verify_verb, verify_.threads);

    CLI::App& status_verb = verb("status", "how far a run is that goes on, or was stopped: blocks, rate, failures",
                                 [this] { return status(status_); });
    status_verb.add_option("RESULT", status_.results, "result files, or the folders of their parts")->required();
    status_verb.add_flag("--json", status_.json, "print JSON instead of text");

    add_summary_options(verb("summary", "print a result as tables", [this] { return summary(summary_); }), summary_);

    CLI::App& audit_verb = verb("audit", "solve the failed trials of a result again with Ceres; writes nothing",
                                [this] { return audit(audit_); });
    audit_verb.add_option("RESULT", audit_.result, "result file")->required();
    audit_verb.add_option("--trials", audit_.trials, "only the first N trials of each cell")
        ->check(CLI::Range(std::uint64_t{1}, studies::max_trials))
        ->type_name("N");
    add_threads(audit_verb, audit_.threads);

    CLI::App& replay_verb = verb("replay", "one trial of a result or a study again, iteration by iteration",
                                 [this] { return replay(replay_); });
    replay_verb.add_option("SOURCE", replay_.source, "result file, study file, or name from the catalog")->required();
    replay_verb
        .add_option("--cell", replay_.cell, "values of the sweep, or the number of a cell (default: the only one)")
        ->type_name("AXIS=VALUE,...");
    replay_verb.add_option("--trial", replay_.trial, "number of the trial, beyond the last one too")
        ->required()
        ->check(CLI::Range(std::uint64_t{0}, studies::max_trials - 1))
        ->type_name("N");
    add_names(replay_verb, "--method", replay_.methods, "method of the study; may be repeated (default: all)");
    add_names(replay_verb, "--solver", replay_.solvers,
              "solver beside the methods, with the study's [solver]; may be repeated");
    replay_verb.add_flag("--json", replay_.json, "print JSON instead of tables");
    replay_verb.add_option("-o", replay_.output, "picture to draw: .svg, .pdf or .png")->type_name("FILE");

    add_solve_options(
        verb("solve", "positions from measured ranges, with their covariance", [this] { return solve(solve_); }),
        solve_);

    add_export_options(
        verb("export", "write a result as CSV, JSON or LaTeX", [this] { return export_result(export_); }), export_);

    add_plot_options(verb("plot", "draw the figures of a result, or another one", [this] { return plot(plot_); }),
                     plot_);

    CLI::App& report_verb = verb("report", "write results as one HTML page that opens anywhere, offline",
                                 [this] { return report(report_); });
    report_verb.add_option("RESULT", report_.results, "result files")->required();
    report_verb.add_option("-o", report_.output, "file to write (default: NAME.html, of several results report.html)")
        ->type_name("FILE");
  }

  int run_verb(int argc, char** argv) {
    check_verb(argc, argv);
    try {
      app_.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
      return app_.exit(help);
    } catch (const CLI::CallForVersion& version) {
      return app_.exit(version);
    } catch (const CLI::ParseError& error) {
      return complain(fmt::format("{} (see ridgeloc {}--help)", error.what(), chosen_name()), BadInput);
    }
    return action_();
  }

 private:
  /// The library would only say that a verb is missing; a misspelt one deserves its neighbour's name.
  void check_verb(int argc, char** argv) const {
    std::vector<std::string> names;
    for (const CLI::App* sub : app_.get_subcommands({})) names.push_back(sub->get_name());
    if (argc < 2 || argv[1][0] == '-' || std::ranges::find(names, argv[1]) != names.end()) return;
    const std::string nearest = studies::nearest_name(argv[1], names);
    throw core::InputError(fmt::format("unknown verb \"{}\"{} (verbs: {})", argv[1],
                                       nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest),
                                       fmt::join(names, ", ")));
  }

  CLI::App& verb(const char* name, const char* description, std::function<int()> action) {
    CLI::App* sub = app_.add_subcommand(name, description);
    sub->final_callback([this, action = std::move(action)] { action_ = action; });
    return *sub;
  }

  std::string chosen_name() const {
    const auto chosen = app_.get_subcommands();
    return chosen.empty() ? "" : chosen.front()->get_name() + " ";
  }

  CLI::App app_{"Monte Carlo studies for robust ridge localization", "ridgeloc"};
  std::function<int()> action_;
  ListOptions list_;
  NewOptions new_;
  PlanOptions plan_;
  RunOptions run_;
  MergeOptions merge_;
  CompareOptions compare_;
  VerifyOptions verify_;
  StatusOptions status_;
  SummaryOptions summary_;
  AuditOptions audit_;
  ReplayOptions replay_;
  SolveOptions solve_;
  ExportOptions export_;
  PlotOptions plot_;
  ReportOptions report_;
};

}  // namespace

int run_command_line(int argc, char** argv) {
  prepare_standard_streams();
  // A write beyond the file-size limit then fails like one to a full disk, instead of killing the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const int code = CommandLine().run_verb(argc, argv);
    finish_standard_output();
    return code;
  } catch (const core::InputError& error) {
    return complain(error.what(), BadInput);
  } catch (const OutputLost& error) {
    // Who reads no further, as `head` does, wants no more lines.
    return is_reader_gone() ? IoFailure : complain(error.what(), IoFailure);
  } catch (const core::IoError& error) {
    return complain(error.what(), IoFailure);
  } catch (const std::bad_alloc&) {
    return complain("out of memory; a smaller sweep or fewer threads needs less", IoFailure);
  } catch (const std::exception& error) {
    const bool of_output = std::ferror(stdout) != 0;
    return of_output && is_reader_gone() ? IoFailure : complain(error.what(), IoFailure);
  }
}

}  // namespace ridgeloc::app
