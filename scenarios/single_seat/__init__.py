"""One seat as a Gymnasium environment, somebody in the other: for those who learn."""
