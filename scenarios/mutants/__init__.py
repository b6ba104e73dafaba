"""Parts made to be bad in one known way: what measures a run must tell them from good ones."""
