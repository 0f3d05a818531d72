#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "osculate/api/run.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;

/// A run that has not ended, or was killed, has left a report.json without increments: no page is
/// written of it over that of an earlier run.
TEST(RewriteReport, WaitsForTheEndOfTheRun) {
  const fs::path folder = fs::path(::testing::TempDir()) / "osculate_rewrite_report";
  fs::create_directories(folder);
  const auto rewritten = [&](const std::string& report) {
    std::ofstream(folder / "report.json") << report;
    std::ofstream(folder / "report.html") << "earlier";
    try {
      rewrite_report(folder.string());
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("osculate view"), std::string::npos) << error.what();
    }
    std::ostringstream page;
    page << std::ifstream(folder / "report.html").rdbuf();
    return page.str();
  };
  EXPECT_EQ(rewritten(R"({"status": "running", "frames": []})"), "earlier");
  for (const char* const report :
       {R"({"status": "done"})", R"({"status": "failed", "summary": {"status": "running"}})",
        R"({"frames": [{"status": "running"}]})"}) {
    const std::string page = rewritten(report);
    EXPECT_NE(page, "earlier") << report;
    EXPECT_NE(page.find("<html"), std::string::npos) << report;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace osculate::api
