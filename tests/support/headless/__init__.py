"""Helpers of tests of the command line: runs, files, disks and simulators."""
