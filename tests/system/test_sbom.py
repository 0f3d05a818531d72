"""The list of what the program consists of. Usage: test_sbom.py PROGRAM SOURCE_DIR"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
BUILD = PROGRAM.resolve().parent.parent


def run(*arguments):
    return subprocess.run([SOURCE / "tools" / "sbom", *arguments], capture_output=True, text=True,
                          env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"})


class Sbom(unittest.TestCase):
    def test_every_library_is_named_with_its_version(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "sbom.json"
            done = run(BUILD, "-o", file)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            text = file.read_text()
        self.assertEqual(run(BUILD).stdout, text)  # the same again
        document = json.loads(text)
        self.assertEqual((document["spdxVersion"], document["SPDXID"]), ("SPDX-2.3", "SPDXRef-DOCUMENT"))
        self.assertEqual(document["creationInfo"]["created"], "2023-11-14T22:13:20Z")
        packages = {package["SPDXID"]: package for package in document["packages"]}
        self.assertEqual(len(packages), len(document["packages"]))
        related = {}
        for relation in document["relationships"]:
            package = packages[relation["relatedSpdxElement"]]
            self.assertTrue(package["versionInfo"], package)
            related.setdefault(relation["relationshipType"], []).append(package["name"])
        self.assertEqual(related["DESCRIBES"], ["osculate"])
        self.assertLessEqual({"libc6", "libyaml-cpp0.7"}, set(related["DYNAMIC_LINK"]))
        self.assertLessEqual({"libmumps-seq-dev", "libeigen3-dev", "nlohmann-json3-dev"}, set(related["STATIC_LINK"]))
        names = related["DYNAMIC_LINK"] + related["STATIC_LINK"]
        self.assertFalse([name for name in names if "gtest" in name or "python" in name], names)

    def test_a_folder_without_a_program_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("not built: ", done.stderr)


if __name__ == "__main__":
    if not shutil.which("dpkg-query") or not (BUILD / "build.ninja").exists():
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
