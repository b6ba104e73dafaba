"""What must hold: formulas, verdicts and margins."""
