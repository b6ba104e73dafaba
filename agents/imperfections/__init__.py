"""What keeps a body from doing exactly what its model asks: wrappers around any human."""
