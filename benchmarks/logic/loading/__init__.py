"""What is loaded: facts and rules as text, and RDF."""
