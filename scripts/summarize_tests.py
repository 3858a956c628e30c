#!/usr/bin/python3
"""Counts the results of all tests: summarize_tests.py RESULTS_FOLDER STATUS_OF_THE_TEST_RUN.

Skipped tests and a failed run count as failures: nothing that was not seen to pass is called passed.
"""
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path


def main():
    folder, run_status = Path(sys.argv[1]), int(sys.argv[2])
    passed, failed = 0, []
    for path in sorted(folder.rglob('*.xml')):
        try:
            root = ElementTree.parse(path).getroot()
        except ElementTree.ParseError as error:
            failed.append('%s: unreadable (%s)' % (path.name, error))
            continue
        cases = list(root.iter('testcase'))
        # A test program that died before its first test leaves a suite with an error and no cases.
        if not cases:
            failed.append('%s: no test ran' % path.name)
        # Python's runner tells of parts of a case (subTest) that failed in the suite's numbers only.
        for suite in root.iter('testsuite'):
            told = sum(int(suite.get(key) or 0) for key in ('failures', 'errors'))
            shown = sum(case.find(tag) is not None for case in suite.iter('testcase') for tag in ('failure', 'error'))
            if told > shown:
                failed.append('%s: %d failures that no case shows' % (path.name, told - shown))
        for case in cases:
            wrong = [entry for entry in map(case.find, ('failure', 'error', 'skipped')) if entry is not None]
            if wrong:
                text = (wrong[0].get('message') or wrong[0].text or '').strip().splitlines()
                failed.append('%s.%s: %s' % (case.get('classname'), case.get('name'), text[0] if text else wrong[0].tag))
            else:
                passed += 1
    if run_status != 0 and not failed:
        failed.append('the test run itself ended with status %d' % run_status)
    if passed == 0 and not failed:
        failed.append('no test ran')
    for line in failed:
        print('FAILED', line)
    print('%d passed, %d failed' % (passed, len(failed)))
    sys.exit(1 if failed else 0)


main()
