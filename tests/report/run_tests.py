"""Runs the tests of the page on what make_report left: run_tests.py FOLDER."""
import os
import sys
import unittest

import browser

if __name__ == "__main__":
    browser.require()
    os.environ["QUELL_TEST_REPORT"] = os.path.abspath(sys.argv.pop(1))
    here = os.path.dirname(os.path.abspath(__file__))
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.discover(here, "*_test.py"))
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
