"""An artist who does anything in any order, and checks that all agrees after it."""
