#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "src/core/error.h"
#include "src/record/summary.h"
#include "src/record/summary_reader.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::content;
using testing::TemporaryFolder;

Summary some_summary() {
    Summary summary;
    summary.title = "Dominoes \"in a row\"";
    summary.engine = "contact-1994";
    summary.seed = 18446744073709551615u;
    summary.steps = 1000;
    summary.grains = 30;
    summary.totals.steps = 1000;
    summary.totals.contact_sum = 12500;
    summary.totals.moves = {30000, 20, 10};
    summary.totals.deepest = 1e-9;
    summary.totals.ledger.restitution_loss = 0.3;
    summary.totals.ledger.friction_loss = 0.2;
    summary.totals.ledger.wall_work = 0.1;
    summary.totals.ledger.created = 0.05;
    summary.totals.ledger.rises = 0.06;
    summary.initial = {1.0, 0.5, 2.0};
    summary.final_energy = {0.75, 0.5, 1.9};
    summary.state_hash = "0123456789abcdef";
    summary.observables = {{"domino_speed", 1.0 / 3.0}};
    return summary;
}

TEST(SummaryFile, HoldsTheRunInNumbers) {
    const TemporaryFolder folder("summary");
    write_summary(folder / "summary.json", some_summary());
    const auto json = nlohmann::json::parse(content(folder / "summary.json"));
    EXPECT_EQ(json["title"], "Dominoes \"in a row\"");
    EXPECT_EQ(json["seed"].get<std::uint64_t>(), 18446744073709551615u);
    EXPECT_EQ(json["mean_contacts"], 12.5);
    EXPECT_EQ(json["moves"]["accepted"], 29970);
    EXPECT_EQ(json["deepest_overlap"], 1e-9);
    EXPECT_EQ(json["state_hash"], "0123456789abcdef");
    EXPECT_EQ(json["observables"]["domino_speed"].get<double>(), 1.0 / 3.0) << "bits survive";
    EXPECT_FALSE(std::filesystem::exists(folder / "summary.json.part"));
}

TEST(SummaryFile, WhatTheLedgerDoesNotExplainIsShown) {
    const TemporaryFolder folder("summary-ledger");
    write_summary(folder / "summary.json", some_summary());
    const auto energy = nlohmann::json::parse(content(folder / "summary.json"))["energy"];
    // 3.15 - 3.5 = -0.35 happened; 0.1 + 0.05 - 0.3 - 0.2 = -0.35 is booked.
    EXPECT_NEAR(energy["unaccounted"].get<double>(), 0.0, 1e-15);
    EXPECT_NEAR(energy["final"]["total"].get<double>(), 3.15, 1e-15);
    EXPECT_EQ(energy["rises"], 0.06);
}

TEST(SummaryFile, IsReadBackAsItWas) {
    const TemporaryFolder folder("summary-back");
    const Summary written = some_summary();
    write_summary(folder / "summary.json", written);
    const StoredSummary read = read_summary(folder / "");
    EXPECT_EQ(read.engine, written.engine);
    EXPECT_EQ(read.seed, written.seed);
    EXPECT_EQ(read.completed, written.completed);
    EXPECT_EQ(read.steps, written.steps);
    EXPECT_EQ(read.time_step, written.time_step);
    EXPECT_EQ(read.grains, written.grains);
    EXPECT_EQ(read.rejected_share(),
              static_cast<double>(written.totals.moves.rejected) / static_cast<double>(written.totals.moves.tried));
    EXPECT_EQ(read.state_hash, written.state_hash);
    EXPECT_EQ(read.observables, written.observables) << "bits survive";
    EXPECT_TRUE(std::isnan(read.observable("no such")));
}

TEST(SummaryFile, ThatIsNoneIsNamed) {
    const TemporaryFolder folder("summary-none");
    const auto message = [&folder]() -> std::string {
        try {
            read_summary(folder / "");
            return "";
        } catch (const InputError& error) {
            return error.what();
        }
    };
    EXPECT_NE(message().find("summary.json: cannot be read"), std::string::npos) << message();
    for (const char* text : {"", "{\"engine\": 3}", "[]", "{\"engine\": \"contact\"}"}) {
        std::ofstream(folder / "summary.json") << text;
        EXPECT_NE(message().find("summary.json: not a summary of ours"), std::string::npos) << text;
    }
}

TEST(SummaryFile, FolderThatIsNotThereIsARunError) {
    EXPECT_THROW(write_summary("/nowhere/at/all/summary.json", {}), RunError);
}

}  // namespace
}  // namespace polargrain
