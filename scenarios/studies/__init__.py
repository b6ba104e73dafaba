"""Many runs: the paper, smoothers and humans compared."""
