"""What can be seen of a plant: pictures, a window, plain drawings."""
