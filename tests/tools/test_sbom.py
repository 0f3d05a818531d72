"""tools/sbom: what it reads from the outputs of other programs."""
import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
PATH = pathlib.Path(__file__).resolve().parents[2] / "tools" / "sbom"
LOADER = importlib.machinery.SourceFileLoader("sbom", str(PATH))
sbom = importlib.util.module_from_spec(importlib.util.spec_from_loader("sbom", LOADER))
LOADER.exec_module(sbom)


class Sbom(unittest.TestCase):
    def test_shared_libraries_are_those_that_are_found(self):
        self.assertEqual(sbom.shared_libraries(
            "\tlinux-vdso.so.1 (0x00007ffd)\n\tlibz.so.1 => /lib/x/libz.so.1 (0x00007f)\n\tlibq.so => not found\n"
            "\t/lib64/ld-linux-x86-64.so.2 (0x00007f)\n"), ["/lib/x/libz.so.1", "/lib64/ld-linux-x86-64.so.2"])

    def test_headers_are_those_of_the_program(self):
        self.assertEqual(sbom.included_headers(
            "src/osculate/a.o: #deps 3, deps mtime 1 (VALID)\n    ../../src/a.hpp\n    /usr/include/fmt/core.h\n"
            "    /usr/lib/gcc/../include/x.h\n\ntests/b.o: #deps 1, deps mtime 1 (VALID)\n    /usr/include/gtest/gtest.h\n\n"),
            ["/usr/include/fmt/core.h", "/usr/lib/include/x.h"])

    def test_archives_are_those_of_the_command_that_links(self):
        self.assertEqual(sbom.linked_archives(
            "c++ -c /usr/lib/old.a\nc++ -o x a.o src/own.a /usr/lib/libdmumps_seq.a /usr/lib/libz.so /usr/lib/b.a\n"),
            ["/usr/lib/b.a", "/usr/lib/libdmumps_seq.a"])
        self.assertEqual(sbom.linked_archives(""), [])

    def test_licenses_are_named_once(self):
        self.assertEqual(sbom.licenses_of(
            "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\nFiles: *\nLicense: MPL-2\n\n"
            "Files: b\nLicense: Expat\n\nLicense: MPL-2\n the text\n"), ["Expat", "MPL-2"])
        self.assertEqual(sbom.licenses_of("This package was debianized by hand.\n"), [])


if __name__ == "__main__":
    unittest.main()
