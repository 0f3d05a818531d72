#include <gmock/gmock.h>
#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <string>

// Every test is a process of its own, and two run at a time: files by the same name in one folder
// would be written over. Each process has a folder of its own, which ::testing::TempDir() and
// std::filesystem::temp_directory_path() name.
int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  std::string folder = (fs::temp_directory_path() / "osculate-tests-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    std::perror(folder.c_str());
    return 1;
  }
  setenv("TEST_TMPDIR", (folder + "/").c_str(), 1);
  setenv("TMPDIR", folder.c_str(), 1);
  ::testing::InitGoogleMock(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  std::error_code kept;
  fs::remove_all(folder, kept);
  return failed;
}
